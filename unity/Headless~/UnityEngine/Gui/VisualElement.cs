using System;
using System.Collections.Generic;

namespace UnityEngine.UIElements
{
    public enum DisplayStyle
    {
        Flex,
        None,
    }

    public struct StyleFloat
    {
        public float value { get; set; }
        public static implicit operator StyleFloat(float v) => new StyleFloat { value = v };
    }

    public struct StyleEnum<T> where T : struct
    {
        public T value { get; set; }
        public static implicit operator StyleEnum<T>(T v) => new StyleEnum<T> { value = v };
    }

    public interface IStyle
    {
        StyleFloat flexGrow { get; set; }
        StyleEnum<DisplayStyle> display { get; set; }
    }

    public class VisualElement
    {
        readonly List<VisualElement> elements = new List<VisualElement>();

        public IStyle style { get; } = new InlineStyle();
        public void Add(VisualElement child) => elements.Add(child);
        public IEnumerable<VisualElement> Children() => elements;

        sealed class InlineStyle : IStyle
        {
            public StyleFloat flexGrow { get; set; }
            public StyleEnum<DisplayStyle> display { get; set; }
        }
    }

    public class Label : VisualElement
    {
        public string text { get; set; } = "";
    }

    public class IMGUIContainer : VisualElement
    {
        public Action onGUIHandler { get; set; }
        public IMGUIContainer(Action onGUIHandler) => this.onGUIHandler = onGUIHandler;
    }
}

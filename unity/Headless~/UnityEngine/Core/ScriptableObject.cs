using System;

namespace UnityEngine
{
    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>() where T : ScriptableObject => (T)CreateInstance(typeof(T));

        public static ScriptableObject CreateInstance(Type type)
        {
            var instance = (ScriptableObject)Construction.Create(type);
            instance.Awaken();
            return instance;
        }

        internal void Awaken()
        {
            var messages = Messages.Of(GetType());
            Messages.Send(messages.Awake, this);
            Messages.Send(messages.OnEnable, this);
        }
    }
}

using System;
using System.Collections;
using System.Collections.Generic;
using System.Reflection;
using System.Reflection.Emit;

namespace UnityEngine
{
    /// The message methods of a script type. They are found by name once, and compiled to direct calls. Missing methods are null.
    sealed class Messages
    {
        static readonly Dictionary<Type, Messages> Tables = new Dictionary<Type, Messages>();

        /// Messages whose methods cannot be coroutines in Unity. Such methods are not called.
        static readonly string[] NonCoroutines =
        {
            nameof(Awake), nameof(OnEnable), nameof(FixedUpdate), nameof(Update), nameof(LateUpdate), nameof(OnDisable), nameof(OnDestroy),
        };

        public readonly int Order;
        public readonly Action<Object> Awake, OnEnable, Start, FixedUpdate, Update, LateUpdate, OnDisable, OnDestroy, OnApplicationQuit;
        public readonly Action<Object> OnTransformParentChanged, OnTransformChildrenChanged;
        public readonly Action<Object, Collider> OnTriggerEnter, OnTriggerStay, OnTriggerExit;
        public readonly Action<Object, Collision> OnCollisionEnter, OnCollisionStay, OnCollisionExit;

        public readonly Action<Object, float> OnJointBreak;

        public readonly TouchMessages Touches;

        Messages(Type type)
        {
            Order = type.GetCustomAttribute<DefaultExecutionOrder>(true)?.order ?? 0;
            Awake = Compile(type, nameof(Awake));
            OnEnable = Compile(type, nameof(OnEnable));
            Start = Compile(type, nameof(Start));
            FixedUpdate = Compile(type, nameof(FixedUpdate));
            Update = Compile(type, nameof(Update));
            LateUpdate = Compile(type, nameof(LateUpdate));
            OnDisable = Compile(type, nameof(OnDisable));
            OnDestroy = Compile(type, nameof(OnDestroy));
            OnApplicationQuit = Compile(type, nameof(OnApplicationQuit));
            OnTransformParentChanged = Compile(type, nameof(OnTransformParentChanged));
            OnTransformChildrenChanged = Compile(type, nameof(OnTransformChildrenChanged));
            OnTriggerEnter = Compile<Collider>(type, nameof(OnTriggerEnter));
            OnTriggerStay = Compile<Collider>(type, nameof(OnTriggerStay));
            OnTriggerExit = Compile<Collider>(type, nameof(OnTriggerExit));
            OnCollisionEnter = Compile<Collision>(type, nameof(OnCollisionEnter));
            OnCollisionStay = Compile<Collision>(type, nameof(OnCollisionStay));
            OnCollisionExit = Compile<Collision>(type, nameof(OnCollisionExit));
            OnJointBreak = Compile<float>(type, nameof(OnJointBreak));
            WarnIfNeverSent(type, "OnApplicationFocus");
            WarnIfNeverSent(type, "OnApplicationPause");
            if (OnTriggerEnter != null || OnTriggerExit != null) Touches |= TouchMessages.TriggerChange;
            if (OnTriggerStay != null) Touches |= TouchMessages.TriggerStay;
            if (OnCollisionEnter != null || OnCollisionExit != null) Touches |= TouchMessages.CollisionChange;
            if (OnCollisionStay != null) Touches |= TouchMessages.CollisionStay;
        }

        public static Messages Of(Type type)
        {
            if (!Tables.TryGetValue(type, out var table)) Tables.Add(type, table = new Messages(type));
            return table;
        }

        /// Returns the topmost base type with [DisallowMultipleComponent], or null. An object can have only one component of such a type.
        public static Type SingleBase(Type type)
        {
            Type single = null;
            for (var level = type; level != typeof(Component); level = level.BaseType)
                if (level.IsDefined(typeof(DisallowMultipleComponent), false)) single = level;
            return single;
        }

        /// Calls a message method. If it throws an exception, logs the exception and returns false.
        public static bool Send(Action<Object> message, Object target)
        {
            if (message == null) return true;
            try
            {
                message(target);
                return true;
            }
            catch (Exception exception)
            {
                Headless.Loop.LogFailedCall(exception, target);
                return false;
            }
        }

        public static void Send<T>(Action<Object, T> message, Object target, T argument)
        {
            if (message == null) return;
            try
            {
                message(target, argument);
            }
            catch (Exception exception)
            {
                Headless.Loop.LogFailedCall(exception, target);
            }
        }

        static Action<Object> Compile(Type type, string name)
        {
            var method = Find(type, name);
            if (method == null) return null;
            if (method.ReturnType != typeof(IEnumerator) || Array.IndexOf(NonCoroutines, name) < 0)
                return (Action<Object>)Emit(method, typeof(Action<Object>), typeof(Object));
            Debug.LogError($"Script error ({type.Name}): {name}() can not be a coroutine.");
            return null;
        }

        static Action<Object, T> Compile<T>(Type type, string name)
        {
            var method = Find(type, name, typeof(T));
            return method == null ? null : (Action<Object, T>)Emit(method, typeof(Action<Object, T>), typeof(Object), typeof(T));
        }

        static void WarnIfNeverSent(Type type, string name)
        {
            if (Find(type, name, typeof(bool)) != null) Debug.LogWarning($"{type.Name}.{name} is never called without Unity.");
        }

        /// Returns the method with the given name in the most derived class. It may be private, and may lack the argument.
        static MethodInfo Find(Type type, string name, Type argument = null)
        {
            MethodInfo other = null;
            for (var level = type; level != typeof(MonoBehaviour) && level != typeof(ScriptableObject) && level != null; level = level.BaseType)
                foreach (var method in level.GetMethods(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
                {
                    if (method.Name != name || method.IsGenericMethodDefinition) continue;
                    var parameters = method.GetParameters();
                    if (parameters.Length == 0 || parameters.Length == 1 && parameters[0].ParameterType == argument) return method;
                    other = method;
                }
            // Scriptable objects receive few of these messages.
            if (other == null || !type.IsSubclassOf(typeof(MonoBehaviour))) return null;
            var types = string.Join(", ", Array.ConvertAll(other.GetParameters(), parameter => parameter.ParameterType.Name));
            Debug.LogError($"Script error ({type.Name}): {name}({types}) is never called: "
                + (argument == null ? "the message has no parameter." : $"the message has one parameter, of type {argument.Name}."));
            return null;
        }

        static Delegate Emit(MethodInfo method, Type signature, params Type[] parameters)
        {
            var call = new DynamicMethod(method.Name, typeof(void), parameters, method.DeclaringType, true);
            var code = call.GetILGenerator();
            var runsAsCoroutine = method.ReturnType == typeof(IEnumerator);
            if (runsAsCoroutine) code.Emit(OpCodes.Ldarg_0);
            code.Emit(OpCodes.Ldarg_0);
            code.Emit(OpCodes.Castclass, method.DeclaringType);
            if (method.GetParameters().Length == 1) code.Emit(OpCodes.Ldarg_1);
            code.Emit(OpCodes.Callvirt, method);
            if (runsAsCoroutine)
            {
                code.Emit(OpCodes.Call, typeof(MonoBehaviour).GetMethod(nameof(MonoBehaviour.StartCoroutine), new[] { typeof(IEnumerator) }));
                code.Emit(OpCodes.Pop);
            }
            else if (method.ReturnType != typeof(void)) code.Emit(OpCodes.Pop);
            code.Emit(OpCodes.Ret);
            return call.CreateDelegate(signature);
        }
    }
}
